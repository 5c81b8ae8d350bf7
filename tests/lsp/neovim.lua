-- A session in Neovim with the settings of docs/use/editors.md; prints one JSON object of results.
-- Arguments: the settings as Lua, the folder, the Python that runs rapidgen.
local settings, folder, python = arg[1], arg[2], arg[3]
local result = {}

local function wait(what, condition)
  if not vim.wait(20000, condition, 20) then
    error("nothing came: " .. what)
  end
end

dofile(settings)
vim.lsp.config("rapidgen", { cmd = { python, "-m", "rapidgen", "lsp" } })
vim.cmd.edit(folder .. "/Main.mod")
local buffer = vim.api.nvim_get_current_buf()
wait("a client", function()
  return #vim.lsp.get_clients({ bufnr = buffer }) == 1
end)
local client = vim.lsp.get_clients({ bufnr = buffer })[1]
wait("findings", function()
  return #vim.diagnostic.get(buffer) > 0
end)
result.filetype = vim.bo.filetype
result.units = client.offset_encoding
result.findings = vim.tbl_map(function(d)
  return d.code .. ":" .. d.lnum
end, vim.diagnostic.get(buffer))

local function ask(method, line, column, more)
  local place = { line = line, character = column }
  local params = { textDocument = vim.lsp.util.make_text_document_params(buffer), position = place }
  local answer = client:request_sync(method, vim.tbl_extend("force", params, more or {}), 20000, buffer)
  assert(answer and not answer.err, vim.inspect(answer))
  return answer.result
end

local places = ask("textDocument/definition", 6, 9)
result.definition = (places[1].targetSelectionRange or places[1].range).start.line
result.hover = ask("textDocument/hover", 6, 16).contents.value
result.symbols = #ask("textDocument/documentSymbol", 0, 0)[1].children
result.tokens = #ask("textDocument/semanticTokens/full", 0, 0).data % 5

-- A rename changes both files, in buffers that are not saved.
local edit = ask("textDocument/rename", 12, 10, { newName = "total" })
vim.lsp.util.apply_workspace_edit(edit, client.offset_encoding)
result.renamed = vim.api.nvim_buf_get_lines(buffer, 12, 13, false)[1]

-- An edit that breaks a statement, then a quick fix.
vim.api.nvim_buf_set_lines(buffer, 6, 7, false, { "        unused = 1;" })
wait("the syntax error", function()
  return #vim.tbl_filter(function(d)
    return d.code == "RG201"
  end, vim.diagnostic.get(buffer)) == 1
end)
local range = { start = { line = 6, character = 0 }, ["end"] = { line = 6, character = 1 } }
local actions = ask("textDocument/codeAction", 6, 0, { range = range, context = { diagnostics = {} } })
result.fix = actions[1].title
vim.lsp.util.apply_workspace_edit(actions[1].edit, client.offset_encoding)
wait("its end", function()
  return #vim.tbl_filter(function(d)
    return d.code == "RG201"
  end, vim.diagnostic.get(buffer)) == 0
end)
result.fixed = vim.api.nvim_buf_get_lines(buffer, 6, 7, false)[1]
vim.lsp.stop_client(vim.lsp.get_clients())
wait("the end of the client", function()
  return client:is_stopped()
end)
io.stdout:write(vim.json.encode(result) .. "\n")
vim.cmd("qa!")
