; What the words of a model are, for editors that colour by tree-sitter (Neovim, Zed, Emacs; Helix has its own names).

(comment) @comment
((comment) @comment.documentation
  (#match? @comment.documentation "^///[^/]"))

(string) @string
(escape) @string.escape
(number) @number
(boolean) @boolean

[
  "class" "extends" "predicate" "action" "enum" "typedef" "filter" "enforce" "new" "super" "close" "condition" "effect"
  "goal" "fact" "rejectable"
] @keyword
["if" "else" "foreach" "in"] @keyword
"#include" @keyword
(relation_word) @keyword.operator

(type ["int" "float" "bool" "string"] @type.builtin)
(type (identifier) @type)
(class name: (identifier) @type)
(class base: (identifier) @type)
(typedef name: (identifier) @type)
(enum name: (identifier) @type)
(enum value: (identifier) @constant)
(new class: (identifier) @type)
(constructor name: (identifier) @constructor)
(rule class: (identifier) @type)
(rule predicate: (identifier) @function)
(predicate name: (identifier) @function)
(instance predicate: (name (identifier) @function))
(instance predicate: (path member: (identifier) @function .))
(call function: (identifier) @function)
(call function: (identifier) @function.builtin
  (#eq? @function.builtin "sampledParameter"))
(method_call method: (path member: (identifier) @function .))

(declarator name: (identifier) @variable)
(parameter name: (identifier) @variable.parameter)
(instance name: (identifier) @variable)
(name (identifier) @variable)
((name (identifier) @constant)
  (#match? @constant "^[A-Z][A-Z0-9_]+$"))
((declarator name: (identifier) @constant)
  (#match? @constant "^[A-Z][A-Z0-9_]+$"))
(path (identifier) @variable)
(path member: (identifier) @property)
(this) @variable.builtin
((name (identifier) @variable.builtin)
  (#match? @variable.builtin "^(object|state|start|end|duration|time)$"))

["==" "!=" "<" "<=" ">" ">=" "=" "+" "-" "*" "/" "!" "&&" "||"] @operator
["{" "}" "(" ")" "[" "]"] @punctuation.bracket
[";" "," "." "::" ":"] @punctuation.delimiter
