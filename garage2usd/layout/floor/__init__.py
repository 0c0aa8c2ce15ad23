"""Floor of the garage: floor panels, painted markings, drains, puddles and stains."""
