"""A study file in, failure rates of model variants under several samplings out."""
