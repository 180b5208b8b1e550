"""What z3 proves of models: of conflicts, of plans over all values, of rules by themselves."""
