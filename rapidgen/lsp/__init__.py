"""Language server: RAPID, cfg and YAML in every editor that speaks LSP."""
