"""An attack on the commands: mutated inputs, and kills at random moments."""
