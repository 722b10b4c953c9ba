"""Where the public tensile tests are read from: a folder of the reader's, or the network.

The Soft Robotics Materials Database is under the Open Database License 1.0; its files are not
part of this package.
"""

from pathlib import Path

from softgrip.errors import UnknownNameError
from softgrip.published import PublishedFiles

FOLDER_VARIABLE = "SOFTGRIP_MATERIALS_DIR"
"""Environment variable that names a folder of the files; unset or empty for the network."""
URL = (
    "https://raw.githubusercontent.com/LucMarechal/Soft-Robotics-Materials-Database/"
    "8ff66c3bdc17bd226eabe83b778e13ea1e2ef8ce/Tensile-Tests-Data/"
)
SHA256 = {
    "Dragon Skin 10 MEDIUM": "01cbda9d2aabe7bd32aa16f0464ece700ab5872a8e225948c9a3fa91f00cbbf2",
    "Dragon Skin 20": "5921554fe92a14eeec8fb6236f869d77a05e1514880d558d5cebc913f8438b67",
    "Dragon Skin 30": "ea9a0cc595c368327cb28716e6a69836d639b1e0b5e60f137ca1b826227a96f0",
    "Dragon Skin FX Pro": "72da6e2360a9045acae68703dc4f5163a583641ecc0dc5b84ce0aba9af395f3f",
    "Ecoflex 00-10": "02b828d0d611e99ebc0c52375f3a939efa9de8381f03591c39697b01a0f9228e",
    "Ecoflex 00-30": "34c00bcc55c401e2c6da596222deed71a8a51ba0be590a5aebe32eac07a19b27",
    "Ecoflex 00-50": "6e902c87b804fa690a71836e4dd308f4ea49fd58b783abc91a6dfe45f70befb9",
    "Mold Star 16 FAST": "3fd58d5ebf34dca1882ba001b1d19e0a339cd82de561eb07b96ac16e96b38ef5",
    "Mold Star 20T": "5f62f0f6db08c8e95a9850504a6f9f6e68ce8403123c6297261a9bfd09fe2836",
    "SORTA-Clear 40": "b595d579e6f75632bb118d7517202b567d7269a16de9006babfa9751bd00c848",
}
"""Digest of each material's file, by the names of Table 5.1."""


def file_name(name: str) -> str:
    """Return the database's file name of a material.

    Raises:
        UnknownNameError: If the name is not one of Table 5.1.

    >>> file_name("SORTA-Clear 40")
    'SortaClear 40.csv'
    """
    if name not in SHA256:
        raise UnknownNameError("material", name, list(SHA256))
    return f"{name.replace('SORTA-Clear', 'SortaClear')}.csv"


FILES = PublishedFiles(
    FOLDER_VARIABLE, URL, {file_name(name): digest for name, digest in SHA256.items()}
)


def locate(name: str) -> Path:
    """Return the path of a material's file, fetched if need be, with its digest checked.

    Raises:
        UnknownNameError: If the name is not one of Table 5.1.
        DataUnavailableError, DataFileError: As `PublishedFiles.locate` does.
    """
    return FILES.locate(file_name(name))


def available() -> bool:
    """Tell whether all files can be read; as `PublishedFiles.available`, with its errors."""
    return FILES.available()


def statement() -> str:
    """Say in a sentence whether the tests are read, and if not, what stands in for them."""
    if available():
        return "The ten tensile tests were read, each checked against its published digest."
    return (
        "The tensile tests could not be had (no network, and no folder is named in "
        f"{FOLDER_VARIABLE}): measured curves are missing from the figures, and exponents are "
        "those of kept fits."
    )
