"""A verdict beside each printed number: claims, their recomputation, and what came of it."""

from softgrip.ledger.claims import Claim, read_claims
from softgrip.ledger.verdict import Entry, Verdict, judge, ledger

__all__ = ["Claim", "Entry", "Verdict", "judge", "ledger", "read_claims"]
