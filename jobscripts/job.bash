# What the jobscripts for Slurm and PBS share; they source it.
#
# A job that runs out of time leaves a checkpoint, goes back into the queue and goes on from it, until
# the run is done. It does not go back if nothing was won since it started, if it was cancelled, or if
# the run ended with any other status than "not finished, nothing wrong" (docs/restart.md).

# The program of this build, or the one in PATH.
find_mpm_par() {
  mpm_par=${MPM_PAR:-build/mpm_par}
  if [ -z "${MPM_PAR:-}" ] && [ ! -x "$mpm_par" ]; then mpm_par=$(command -v mpm_par || true); fi
  if [ ! -x "$mpm_par" ]; then
    echo "$PWD: no program '${mpm_par:-build/mpm_par}' here or in PATH: build it (docs/building.md)," \
      "submit from the top folder, or name it in the variable MPM_PAR." >&2
    exit 1
  fi
}

# The step of the newest checkpoint; nothing if there is none.
newest_checkpoint() {
  if [ -d "$1/checkpoints" ]; then
    find "$1/checkpoints" -regextype posix-extended -regex '.*/[0-9]{12}\.h5' -printf '%f\n' | sort |
      tail -n 1 | sed 's/\.h5$//'
  fi
}

# arguments_of_job JOB [ARGUMENT ...]
#
# Sets `arguments`, what mpm_par is called with: what the job was submitted with or, if its own run is
# in the folder already, what goes on with that. JOB stays the same when a job is started once more. A
# run of anyone else may be in a folder that RESULTS names; it is left to mpm_par to refuse that one.
arguments_of_job() {
  begun=$output/begun_by_job_$1
  made_folder=
  shift
  if own_run_is_there; then
    go_on_with "$@"
    return
  fi
  arguments=("$@")
  if [ ! -d "$output" ]; then
    mkdir -p "$output"
    made_folder=yes
  fi
  run_there >"$begun"
}

# Tells runs in the folder apart: each that begins or goes on replaces its scene.yaml by a new file.
run_there() { stat -c '%i %y' "$output/scene.yaml" 2>/dev/null || echo none; }

# Has a run begun in the folder since this job first came to it? A node that failed may have left
# the file empty.
own_run_is_there() { [ -s "$begun" ] && [ "$(run_there)" != "$(cat "$begun")" ]; }

# The same `arguments` for a job that comes back: from its newest checkpoint, whichever it began with,
# or anew if a node failed before there was one. What has a summary has come to its end: it is kept.
go_on_with() {
  arguments=()
  local argument before=
  for argument; do
    case $before$argument in
      --overwrite | --restart | --restart*.h5) ;;
      *) arguments+=("$argument") ;;
    esac
    if [ "$argument" = --restart ]; then before=$argument; else before=; fi
  done
  if [ -n "$(progress)" ]; then
    arguments+=(--restart)
  elif [ ! -e "$output/summary.json" ]; then
    arguments+=(--overwrite)
  fi
}

# What has come to its end, or was refused before it began, is not gone on with.
forget_beginning() {
  if [ "$1" -ne 0 ] && own_run_is_there; then return; fi
  rm -f "$begun"
  if [ -n "$made_folder" ]; then rmdir --ignore-fail-on-non-empty "$output"; fi
}

# Ends the job with the status of its command.
end_job() {
  if [ -n "${begun:-}" ]; then forget_beginning "$1"; fi
  exit "$1"
}

# submit_again NAME
#
# For PBS: another job that goes on with this one's scene, arguments and folder; AGAIN is the first of
# them all. PBS runs a copy of the script as it was submitted, with all that was filled in there; where
# that is not to be read, it is NAME.
submit_again() {
  local script=${JOBSCRIPT:-$0} names=SCENE,ARGUMENTS,RESULTS,TIME_LIMIT,AGAIN,MPM_PAR,MPM_JOBSCRIPTS
  if [ ! -r "$script" ]; then script=$jobscripts/$1; fi
  export SCENE ARGUMENTS=${ARGUMENTS:-} RESULTS=$output TIME_LIMIT=$time_limit AGAIN=${AGAIN:-$PBS_JOBID}
  qsub -v "$names${MPM_LAUNCH:+,MPM_LAUNCH}${JOBSCRIPT:+,JOBSCRIPT}" "$script"
}

# run_in_job SIGNAL STATUS COMMAND [ARGUMENT ...]
#
# Runs the command. The scheduler's warning, USR1, is handed on to it as SIGNAL, and it is expected to
# end with STATUS if it has not finished. The script defines two functions before: `progress` prints
# how far the work is, and `queue_again` puts this job back into the queue. Where no warning comes,
# because the command watches the clock itself, `out_of_time=yes` is set before.
run_in_job() {
  local signal=$1 unfinished=$2 before after status
  shift 2
  before=$(progress)
  out_of_time=${out_of_time:-}
  cancelled=
  # Tasks get signals through their launcher, which hands them on.
  trap 'out_of_time=yes; interrupted=yes; kill -s "$signal" "$launcher" 2>/dev/null || true' USR1
  trap 'cancelled=yes; interrupted=yes; kill -s TERM "$launcher" 2>/dev/null || true' TERM
  "$@" &
  launcher=$!
  interrupted=yes
  while [ -n "$interrupted" ]; do  # a signal ends `wait`, not the command
    interrupted=
    status=0
    wait "$launcher" || status=$?
  done
  trap '' USR1 TERM
  after=$(progress)
  echo "ended with status $status, $(date)"
  if [ "$status" -ne "$unfinished" ] || [ -z "$out_of_time" ] || [ -n "$cancelled" ]; then
    end_job "$status"
  fi
  if [ "$before" = "$after" ]; then
    echo "nothing was won since the job started (${after:-no checkpoint}): not queued again." \
      "Ask for more time." >&2
    end_job "$status"
  fi
  echo "not finished (${before:-start} -> $after): back into the queue"
  queue_again
}
