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


def facts_of(folder):
    """Of the summary."""
    return {key: value for key, value in summary(folder).items()
            if not any(word in key for word in NOT_REPEATED) and key not in ("name", "results")}
