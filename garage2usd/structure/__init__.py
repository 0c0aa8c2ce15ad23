"""The structure of a garage: its matrices S, R and C, and the properties derived from them alone.

`grid` holds the matrices, `stalls` counts stalls per square, `lane_graph` types the lanes and proves that every stall
is reached, `lanes` has directions and dead-end aisles, and `symmetry` compares plans up to
rotation and reflection.
"""
