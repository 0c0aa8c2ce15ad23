"""Parking: stalls and their use, parked cars, and what stands beside them."""
