"""Result of a verification: one line for each check, and every finding with its place."""

from __future__ import annotations

from dataclasses import dataclass, field

from cfree.scene.reading import Note
from cfree.scene.reading_lines import Claim, harms
from cfree.words import counted, listed

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
    reading : tuple of Note
        The records of reading of the scene and of the answer's file.
    claim : "path", "no path" or "scene"
        The claim that these notes may harm.
    """

    checks: tuple[Check, ...]
    findings: tuple[Finding, ...]
    euler: tuple[int, ...]
    seconds: float = field(compare=False)
    proved: str = ""
    reading: tuple[Note, ...] = ()
    claim: Claim = "scene"

    @property
    def verified(self) -> bool:
        """True if no check found anything."""
        return not self.findings

    def __str__(self) -> str:
        rows = [f"{check.how:<8} {check.name}: {check.extent}" for check in self.checks]
        rows += [str(finding) for finding in self.findings[:SHOWN]]
        return "\n".join([*rows, self.verdict, *([self.as_read] if self.as_read else [])])

    @property
    def verdict(self) -> str:
        """Last line of a report."""
        if self.verified:
            return f"{self.proved and self.proved + ' '}verified ({self.seconds:.1f} s)"
        more = len(self.findings) - SHOWN
        hidden = f", {more:,} not shown" * (more > 0)
        return f"REFUTED: {counted(len(self.findings), 'finding')}{hidden} ({self.seconds:.1f} s)"

    @property
    def as_read(self) -> str:
        """Statement about the scene's record of reading, if it harms what is proved; else empty."""
        harmful = harms(self.reading, self.claim)
        if not harmful or not self.verified:
            return ""
        how = "within a tolerance" if harmful[0].effect == "near" else "with losses"
        notes = listed([note.subject for note in harmful])
        return f"{PROVED} for the scene in this file, which was read {how}: {notes}"
