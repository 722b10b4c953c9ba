"""Files that others published and that are no part of this package, each pinned by its digest.

They are read from a folder of the reader's, or fetched once and kept in the user's cache.
"""

import hashlib
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any
from urllib.parse import quote

import pooch

from softgrip.errors import DataFileError, DataUnavailableError

TIMEOUT = 5.0
"""Seconds to wait for the network: pages are built without it too."""


@dataclass(frozen=True, eq=False)
class PublishedFiles:
    """Files at one address.

    Attributes:
        variable: Environment variable that names a folder of the files; unset or empty for the
            network.
        address: Where they were published, at a fixed version, with a slash at its end.
        sha256: Digest of each file, by its name.
        other_names: Second names by which a folder may hold them.
    """

    variable: str
    address: str
    sha256: Mapping[str, str]
    other_names: Mapping[str, str] = field(default_factory=dict)

    def locate(self, file: str) -> Path:
        """Return the path of a file, fetched if need be, with its digest checked.

        Raises:
            DataUnavailableError: If the named folder or its file is missing, or the network did
                not give the file.
            DataFileError: If the folder's file is not, byte by byte, the published one.
        """
        folder = os.environ.get(self.variable)
        return self._from_folder(Path(folder), file) if folder else self._from_network(file)

    def available(self) -> bool:
        """Tell whether all files can be read; without network it is tried once a process.

        Raises:
            DataUnavailableError, DataFileError: If a folder is named and is not in order: a wrong
                setting should not pass for no data.
        """
        if os.environ.get(self.variable):
            return all(self.locate(file) for file in self.sha256)
        return self._network_gives_all

    def _from_folder(self, folder: Path, file: str) -> Path:
        names = [file, *filter(None, [self.other_names.get(file)])]
        path = next((folder / name for name in names if (folder / name).is_file()), None)
        if path is None:
            wanted = " or ".join(map(repr, names))
            missing = f"has no file {wanted}" if folder.is_dir() else "is not a folder"
            raise DataUnavailableError(f"{self.variable} names {folder}, which {missing}.")
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
        if digest != self.sha256[file]:
            raise DataFileError(
                path,
                expected=f"the published bytes, SHA-256 {self.sha256[file][:12]} (line ends count)",
                got=f"a changed file, SHA-256 {digest[:12]}",
            )
        return path

    def _from_network(self, file: str) -> Path:
        download = pooch.HTTPDownloader(timeout=TIMEOUT)
        try:
            return Path(self._store.fetch(file, downloader=download))
        except (OSError, ValueError) as error:
            # OSError: no network or no cache folder; ValueError: other bytes than published.
            raise DataUnavailableError(
                f"{file}: not fetched ({error}). Either let this computer reach {self.address} "
                "once (the files are then kept in its cache), or put the unchanged files in a "
                f"folder and name it in the environment variable {self.variable}."
            ) from error

    @cached_property
    def _network_gives_all(self) -> bool:
        try:
            return all(self._from_network(file) for file in self.sha256)
        except DataUnavailableError:
            return False

    @cached_property
    def _store(self) -> Any:
        pooch.get_logger().setLevel("WARNING")  # a page must not differ by whether it had to fetch
        return pooch.create(
            path=pooch.os_cache("softgrip"),
            base_url=self.address,
            registry={file: f"sha256:{sha256}" for file, sha256 in self.sha256.items()},
            urls={file: self.address + quote(file) for file in self.sha256},
        )
