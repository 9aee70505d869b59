"""Result of a verification: one line for each check, and every finding with its place."""

from __future__ import annotations

from dataclasses import dataclass, field

from cfree.words import counted

PROVED, SAMPLED, SKIPPED, REFUTED = "PROVED", "SAMPLED", "SKIPPED", "REFUTED"
MEASURED = "MEASURED"  # in doubles, by quadrature
SHOWN = 20  # findings in a report


@dataclass(frozen=True, slots=True)
class Finding:
    """Something wrong with a boundary or an answer.

    Attributes
    ----------
    kind : str
        Name of the check that failed.
    where : str
        Trapezoids, patches or an orientation.
    text : str
    """

    kind: str
    where: str
    text: str

    def __str__(self) -> str:
        return f"{self.kind}: {self.where}: {self.text}"


@dataclass(frozen=True, slots=True)
class Check:
    """One check: its name, its outcome (PROVED, SAMPLED, MEASURED, SKIPPED or REFUTED), and its extent with counts."""

    name: str
    how: str
    extent: str


@dataclass(frozen=True, slots=True)
class Verification:
    """Result of `cfree.verify.boundary` or `cfree.verify.answer`.

    Attributes
    ----------
    checks : tuple of Check
        Proved and sampled checks, with counts.
    findings : tuple of Finding
        Faults; empty if all is well.
    euler : tuple of int
        V - E + F of every closed surface, in order; empty if they were not matched.
    seconds : float
    proved : str
        Statement proved, in one sentence, if an answer is verified.
    """

    checks: tuple[Check, ...]
    findings: tuple[Finding, ...]
    euler: tuple[int, ...]
    seconds: float = field(compare=False)
    proved: str = ""

    @property
    def verified(self) -> bool:
        """True if no check found anything."""
        return not self.findings

    def __str__(self) -> str:
        rows = [f"{check.how:<8} {check.name}: {check.extent}" for check in self.checks]
        rows += [str(finding) for finding in self.findings[:SHOWN]]
        return "\n".join([*rows, self.verdict])

    @property
    def verdict(self) -> str:
        """Last line of a report."""
        if self.verified:
            return f"{self.proved and self.proved + ' '}verified ({self.seconds:.1f} s)"
        more = len(self.findings) - SHOWN
        hidden = f", {more:,} not shown" * (more > 0)
        return f"REFUTED: {counted(len(self.findings), 'finding')}{hidden} ({self.seconds:.1f} s)"
