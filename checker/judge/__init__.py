"""An independent judge of executed missions: program and record in, disagreements out; no propagator is asked."""
