"""Parking: stalls, their use and numbers, parked cars, number plates, signs and clutter."""
