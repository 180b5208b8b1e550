"""Plan database: tokens, timelines and rules."""
