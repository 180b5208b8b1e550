-- Start `nddlc lsp` for NDDL models and mission files. Neovim 0.7 or newer.
--
-- Settings, before this is loaded: vim.g.nddlc_command = { "/path/to/nddlc", "lsp" }

if vim.g.loaded_nddlc then
  return
end
vim.g.loaded_nddlc = true

local clients = {} -- by root folder, for 0.7, which does not look for one that runs

local function root_of(file)
  local folder = vim.fn.fnamemodify(file, ":p:h")
  local at = folder
  while true do
    for _, mark in ipairs({ "nddlc.toml", "pyproject.toml", ".git" }) do
      if vim.loop.fs_stat(at .. "/" .. mark) then
        return at
      end
    end
    local above = vim.fn.fnamemodify(at, ":h")
    if above == at then
      return folder
    end
    at = above
  end
end

local function start(buffer)
  local root = root_of(vim.api.nvim_buf_get_name(buffer))
  local config = {
    name = "nddlc",
    cmd = vim.g.nddlc_command or { "nddlc", "lsp" },
    root_dir = root,
    workspace_folders = { { uri = vim.uri_from_fname(root), name = root } },
    capabilities = vim.lsp.protocol.make_client_capabilities(),
  }
  if vim.lsp.start then
    vim.lsp.start(config, { bufnr = buffer })
    return
  end
  if not clients[root] or not vim.lsp.get_client_by_id(clients[root]) then
    clients[root] = vim.lsp.start_client(config)
  end
  vim.lsp.buf_attach_client(buffer, clients[root])
end

local group = vim.api.nvim_create_augroup("nddlc", {})
-- Not vim.filetype.add, which Neovim 0.7 looks at only where the user asks for it.
vim.api.nvim_create_autocmd({ "BufReadPost", "BufNewFile" }, {
  group = group,
  pattern = "*.nddl",
  command = "setfiletype nddl",
})
vim.api.nvim_create_autocmd("FileType", {
  group = group,
  pattern = "nddl",
  callback = function(event)
    vim.bo[event.buf].commentstring = "// %s"
    vim.bo[event.buf].omnifunc = "v:lua.vim.lsp.omnifunc"
    start(event.buf)
  end,
})
vim.api.nvim_create_autocmd({ "BufReadPost", "BufNewFile" }, {
  group = group,
  pattern = { "mission*.toml", "*solver*.toml", "nddlc.toml" },
  callback = function(event)
    start(event.buf)
  end,
})
