"""A slow Sarsa, the property that the compiled one follows it, and faults planted in that."""
