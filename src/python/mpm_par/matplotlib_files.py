"""Files that Matplotlib keeps for itself."""
import atexit
import os
import shutil
import tempfile


def keep_out_of_home():
    """Before Matplotlib is imported by a program, which leaves no file outside its folder of results:
    the list of fonts, and that of fontconfig, from where it is made, are in a folder that is removed
    when the program ends. Where the user names one in MPLCONFIGDIR, it is that one."""
    if os.environ.get("MPLCONFIGDIR"):
        return
    folder = tempfile.mkdtemp(prefix="mpm_par_")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    os.environ.update(MPLCONFIGDIR=folder, XDG_CACHE_HOME=folder)
