"""The role ``{claim}``: a printed number in prose, as its claim has it, with its row linked."""

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxRole

from book.companion.claims import printed_text
from softgrip.errors import UnknownNameError
from softgrip.provenance import data_folder


class ClaimRole(SphinxRole):
    """What a claim prints, linked to its row; the role's text is the claim's id."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        """Return the link; an id that no claim has is an error of the page."""
        for file in (data_folder() / "claims").glob("chapter_*.toml"):
            self.env.note_dependency(str(file))
        try:
            words = printed_text(self.text)
        except UnknownNameError as error:
            told = self.inliner.reporter.error(str(error), line=self.lineno)
            return [self.inliner.problematic(self.rawtext, self.rawtext, told)], [told]
        uri = f"ledger.html#claim-{self.text}"
        return [nodes.reference("", words, refuri=uri, internal=True, classes=["claim"])], []


def setup(app: Sphinx) -> None:
    """Add the role."""
    app.add_role("claim", ClaimRole())
