"""The property that the compiled Sarsa follows its reference, and faults planted in it."""
