"""The command `nddlc`: one file per subcommand, no logic."""
