"""``rasterscope methods``: the table of methods."""

import argparse
import json
import textwrap

import core  # noqa: F401  (its modules register the methods)
from app.usage import UsageError
from core import Settings
from core.methods import Method, table

DESCRIPTION = """List the methods that settings choose from, spelled as --set takes them."""
EXAMPLES = """examples:
  rasterscope methods
  rasterscope methods fill
  rasterscope methods --json
"""
WIDTH = 100


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    parser.add_argument("family", metavar="FAMILY", nargs="?", help="only the methods of one family")
    parser.add_argument("--json", action="store_true", help="every field of the table, as JSON")


def run(options: argparse.Namespace) -> int:
    """Write the table."""
    if options.family is not None and options.family not in table.families:
        raise UsageError(f"family must be one of {', '.join(table.families)}, got {options.family}")
    methods = [method for method in table if options.family in (None, method.family)]
    if options.json:
        print(json.dumps([json_of(method) for method in methods], indent=1))
    else:
        print("\n".join(text_of(method) for method in methods))
    return 0


def json_of(method: Method) -> dict[str, object]:
    """Return a row of the table as JSON has it."""
    return {
        "family": method.family,
        "name": method.name,
        "title": method.title,
        "is_default": is_default(method),
        "source": method.source,
        "exact_for": method.exact_for,
        "breaks_where": method.breaks_where,
        "needs": list(method.needs),
    }


def text_of(method: Method) -> str:
    """Return a row of the table as a person reads it."""
    head = f"{method.family}={method.name}"
    marked = f"{method.title} (default)" if is_default(method) else method.title
    account = f"Exact for {method.exact_for}."
    if method.breaks_where:
        account += f" Breaks: {method.breaks_where}."
    if method.needs:
        account += f" Needs {', '.join(method.needs)}."
    account += f" [{method.source}]"
    body = textwrap.fill(account, WIDTH, initial_indent="    ", subsequent_indent="    ")
    return f"{head:<38}{marked}\n{body}"


def is_default(method: Method) -> bool:
    """Return whether settings have this method where nothing is chosen."""
    return getattr(Settings(), method.family, None) == method.name
