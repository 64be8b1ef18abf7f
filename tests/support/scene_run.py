"""Words that start mpm_par on a scene with some of its keys set."""
import subprocess


def set_options(settings):
    """--set for each KEY=VALUE."""
    return [word for setting in settings for word in ("--set", setting)]


def command(mpm_par, scene, folder, settings=(), *more):
    """Results go to `folder`."""
    return [str(mpm_par), str(scene), "--output", str(folder), *more, *set_options(settings)]


def ended_or_stopped(mpm_par, scene, folder, settings=(), *more):
    """A run that has come to its end (status 0) or that the program has stopped (3)."""
    words = command(mpm_par, scene, folder, settings, *more)
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode not in (0, 3):
        raise RuntimeError(f"{' '.join(words)}\n{done.stdout}{done.stderr}")
    return done
