"""Editor requests in, answers out."""
