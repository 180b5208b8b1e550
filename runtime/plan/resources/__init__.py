"""Resources: who uses them, profiles, envelopes and violations."""
