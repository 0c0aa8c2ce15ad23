"""The structure of a garage: its matrices S, R and C, and what follows from them alone.

`grid` holds the matrices, `stalls` says which squares hold stalls, `lane_graph` types the lanes and proves that every
stall is reached, `dead_ends` and `doors` find aisles that end in nothing and the doors of portals, `symmetry`
tells whether two plans are the same but for a turn or a mirror image.
"""
