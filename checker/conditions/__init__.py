"""A bucket of failures in, the condition on the draws under which missions fail out, tested on fresh missions."""
