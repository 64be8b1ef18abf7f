"""What two runs of one scene share to the last bit, whenever and wherever they were made."""
from program import summary

# Of the clock, of memory, of messages sent, or of the folder.
NOT_REPEATED = ("second", "ns_per", "bytes", "messages")


def files_of(folder):
    """Contents by name."""
    found = {path.name: path.read_bytes()
             for path in [*folder.glob("*.csv"), *folder.glob("*.xdmf"), *folder.glob("snapshots/*.h5")]}
    assert "history.csv" in found
    return found


def all_of(folder):
    """Contents of everything there, by path."""
    return {str(path.relative_to(folder)): path.read_bytes()
            for path in folder.rglob("*") if path.is_file()}


def facts_of(folder):
    """Of the summary."""
    return {key: value for key, value in summary(folder).items()
            if not any(word in key for word in NOT_REPEATED) and key not in ("name", "results")}


def results_of(folder):
    """All that is compared."""
    return files_of(folder) | {"summary.json": facts_of(folder)}


def difference(expected, found):
    """The first file that is not the same in what results_of has found; None if there is none."""
    return next((name for name in sorted({*expected, *found}) if expected.get(name) != found.get(name)),
                None)


def expect_same(test, whole, folder, of=results_of):
    """With the words of a unittest.TestCase; `of`: what is compared of both folders."""
    wrong = difference(of(whole), of(folder))
    test.assertIsNone(wrong, f"{wrong} of {folder} is not that of {whole}")
