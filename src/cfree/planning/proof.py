"""The proofs that no path leads from one pose to another."""

from __future__ import annotations

from cfree.planning.separation import Separated
from cfree.planning.stuck import Stuck
from cfree.planning.unreachable import Unreachable

Proof = Separated | Stuck | Unreachable
