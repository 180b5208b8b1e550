"""Rules: bytecode, guards and the interpreter."""
