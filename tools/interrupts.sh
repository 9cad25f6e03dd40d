# shellcheck shell=bash
# Lets a script that runs programs for hours react to interrupts at once. Bash runs a trap only after the
# program in the foreground has ended. Therefore the script sources this file, and runs programs with
# `attend`.

interrupted=false  # whether INT, TERM or HUP has come
attended=          # the process to which these signals are passed on

# Sends TERM, whichever signal has come: a program that a script has started in the background ignores INT.
on_interrupt() {
  interrupted=true
  [[ -z $attended ]] || { kill -TERM -- "-$attended" || kill -TERM "$attended" || true; } 2>/dev/null
}
trap on_interrupt INT TERM HUP

# await PROCESS: waits until a background process has ended, whatever signals the script gets meanwhile, and
# returns the process's exit code.
await() {
  local code=0
  while kill -0 "$1" 2>/dev/null; do wait "$1" || true; done  # a signal ends the wait
  wait "$1" || code=$?
  return $code
}

# attend COMMAND...: runs a program. An interrupt ends the program with TERM, or keeps it from starting.
# Returns the program's exit code, or 130 if it did not start. A program that would leave its children
# running needs setsid(1): TERM then goes to all of them.
attend() {
  local code=0
  ! $interrupted || return 130
  "$@" &
  attended=$!
  if $interrupted; then on_interrupt; fi  # the signal came before `attended` was set
  await "$attended" || code=$?
  attended=
  return $code
}

# shield COMMAND...: runs a short program that an interrupt must not end, such as the one that writes the
# report.
shield() {
  setsid "$@" &
  await $!
}
