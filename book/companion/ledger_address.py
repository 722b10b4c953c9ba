"""Addresses of the ledger: of a row, and of the rows that a filter leaves."""

from urllib.parse import urlencode

PAGE = "ledger.html"
NONE = "none"
"""In an address, the basis of a number that has none."""


def row_address(claim: str) -> str:
    """Return the address of a claim's row.

    >>> row_address("3.4-plateau")
    'ledger.html#claim-3.4-plateau'
    """
    return f"{PAGE}#claim-{claim}"


def address(**fields: object) -> str:
    """Return the address of the rows that have all of some fields, by the names of the form's.

    >>> address(place="Table 5.2", outcome="close")
    'ledger.html#place=Table+5.2&outcome=close'
    """
    return f"{PAGE}#{urlencode({name: str(value) for name, value in fields.items()})}"
