// The TextMate grammar gives words the scopes that themes colour.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import oniguruma from "vscode-oniguruma";
import textmate from "vscode-textmate";

const here = new URL("..", import.meta.url);
const wasm = readFileSync(new URL("node_modules/vscode-oniguruma/release/onig.wasm", here));
await oniguruma.loadWASM(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength));
const path = new URL("syntaxes/nddl.tmLanguage.json", here);
const registry = new textmate.Registry({
  onigLib: Promise.resolve({
    createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
    createOnigString: (text) => new oniguruma.OnigString(text),
  }),
  loadGrammar: async () => textmate.parseRawGrammar(readFileSync(path, "utf8"), "nddl.tmLanguage.json"),
});
const grammar = await registry.loadGrammar("source.nddl");

const EXPECTED = [
  ["// a remark", "remark", "comment.line"],
  ["/* a remark */ int x;", "remark", "comment.block"],
  ["int x = 3;", "int", "storage.type"],
  ["int x = 3;", "3", "constant.numeric"],
  ['#include "other.nddl"', "include", "keyword"],
  ['#include "other.nddl"', "other", "string"],
  ["class Gps extends Timeline {", "class", "storage.type|keyword"],
  ["  met_by(object.Idle earlier);", "met_by", "keyword"],
  ["goal(gps.Active first);", "goal", "keyword"],
  ["bool b = true;", "true", "constant.language"],
];

for (const [line, word, scope] of EXPECTED) {
  const at = line.indexOf(word);
  const { tokens } = grammar.tokenizeLine(line, textmate.INITIAL);
  const token = tokens.find((each) => each.startIndex <= at && at < each.endIndex);
  assert.match(token.scopes.join(" "), new RegExp(scope), `${word} in ${line}: ${token.scopes.join(" ")}`);
}

// A comment that goes on over lines ends where it ends.
let state = textmate.INITIAL;
const scopes = ["/* one", "two */ int x;"].map((line) => {
  const result = grammar.tokenizeLine(line, state);
  state = result.ruleStack;
  return result.tokens.map((each) => each.scopes.at(-1)).join(" ");
});
assert.match(scopes[0], /comment/);
assert.match(scopes[1], /storage/);
console.log(`${EXPECTED.length + 1} lines are coloured as they should be`);
