"""From a conflict or a bound back along supports to the causes it rests on."""
