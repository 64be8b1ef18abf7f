"""What the snapshots of a turning disc show; the field velocity is in them, and stress."""
import h5py

from measures.places import snapshots


def angular_momentum(folder, level, centre):
    """angular momentum at the end over that at the start"""
    found = []
    for file in (snapshots(folder)[0], snapshots(folder)[-1]):
        with h5py.File(file) as held:
            place, velocity = held["particles/position"][:], held["particles/velocity"][:]
            found.append(((place[:, 0] - centre[0]) * velocity[:, 1] -
                          (place[:, 1] - centre[1]) * velocity[:, 0]).sum())
    return found[1] / found[0]


def virial(folder, level, density):
    """mean of s_xx + s_yy over twice the kinetic energy of a volume, over the second half of the run"""
    files = snapshots(folder)
    stress, energy = 0.0, 0.0
    for file in files[len(files) // 2:]:
        with h5py.File(file) as held:
            stress += held["particles/stress"][:, :2].sum()
            energy += density * (held["particles/velocity"][:]**2).sum()
    return stress / energy
