"""What Kerf says of a surface, a mesh or a run beside its numbers."""

from __future__ import annotations

from typing import Any, Iterable, Mapping

from .option_table import in_python


def in_words_of_python(sentences: Iterable[str]) -> list[str]:
    """Notes of the kernel, with the names of Python for options."""
    return [in_python(sentence) for sentence in sentences]


def notes_of(report: Mapping[str, Any]) -> list[str]:
    """Those of report.json; a report of an older version has none."""
    return in_words_of_python(report.get("notes", []))


def notes_text(notes: list[str]) -> str:
    """How many there are, behind other numbers; empty for none."""
    return f", {len(notes)} note{'s' if len(notes) > 1 else ''}" if notes else ""
