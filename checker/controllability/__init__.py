"""Networks of times with uncertain durations in, whether a plan can be carried out whatever they are out."""
