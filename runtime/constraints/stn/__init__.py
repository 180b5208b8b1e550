"""The simple temporal network, its shortest paths, and the rows of posted constraints."""
