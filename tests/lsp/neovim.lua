-- A user of Neovim: opens a model, reads what is wrong, jumps, completes, mends, renames over two files, formats.
-- NDDLC_SCRIPT is a folder with model.nddl and part.nddl; what was seen goes into seen.json there.
local folder = vim.env.NDDLC_SCRIPT
local seen = {}

local function wait(what, condition)
  if not vim.wait(240000, condition, 20) then
    error("waited in vain for " .. what)
  end
end

local function messages()
  return vim.tbl_map(function(each)
    return each.message
  end, vim.diagnostic.get(0))
end

local function text()
  return table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), "\n") .. "\n"
end

local function ask(method, params)
  local answers = vim.lsp.buf_request_sync(0, method, params, 240000)
  for _, answer in pairs(answers or {}) do
    if answer.err then
      error(method .. ": " .. vim.inspect(answer.err))
    end
    return answer.result
  end
end

local function place(line, column)
  vim.api.nvim_win_set_cursor(0, { line, column })
  return vim.lsp.util.make_position_params(0, "utf-16")
end

local function main()
  vim.cmd("edit " .. folder .. "/model.nddl")
  seen.filetype = vim.bo.filetype
  wait("diagnostics", function()
    return #vim.diagnostic.get(0) > 0
  end)
  seen.wrong = messages()

  place(3, 12)
  vim.lsp.buf.definition()
  wait("the jump", function()
    return vim.api.nvim_buf_get_name(0):match("part%.nddl$")
  end)
  seen.jumped = vim.api.nvim_win_get_cursor(0)
  vim.cmd("buffer model.nddl")

  seen.offered = vim.tbl_map(function(each)
    return each.label
  end, ask("textDocument/completion", place(3, 9)).items)

  local params = vim.lsp.util.make_range_params(0, "utf-16")
  params.range = { start = { line = 3, character = 18 }, ["end"] = { line = 3, character = 18 } }
  params.context = { diagnostics = {} }
  local action = ask("textDocument/codeAction", params)[1]
  seen.action = action.title
  vim.lsp.util.apply_workspace_edit(action.edit, "utf-16")
  wait("the mend", function()
    return #vim.diagnostic.get(0, { severity = vim.diagnostic.severity.ERROR }) == 0
  end)
  seen.mended = text()

  params = place(3, 12)
  params.newName = "Awake"
  vim.lsp.util.apply_workspace_edit(ask("textDocument/rename", params), "utf-16")
  seen.renamed = text()
  vim.cmd("silent wall")

  local format = vim.lsp.buf.formatting_sync or function()
    vim.lsp.buf.format({ async = false })
  end
  format(nil, 240000)
  seen.formatted = text()
  vim.cmd("silent wall")
end

local ok, problem = pcall(main)
seen.problem = not ok and tostring(problem) or nil
local file = assert(io.open(folder .. "/seen.json", "w"))
file:write((vim.json or vim).encode and vim.json.encode(seen) or vim.fn.json_encode(seen))
file:close()
vim.cmd("qall!")
