"""
The paper in 15 minutes
=======================

x
"""

print(1)
