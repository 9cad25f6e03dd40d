# shellcheck shell=bash
# Reads the options of all scripts. A script sources this file before anything else, and declares its options
# with `options`. The comment at the top of a script is its usage.
unset CDPATH  # with it, cd prints a folder, and may go to another one
script=$(realpath "$0")
script_name=${script#"$(realpath "$(dirname "${BASH_SOURCE[0]}")/..")/"}

# refuse WHY: ends the script with exit code 2 and one line that says why.
refuse() { echo "$script_name: $1" >&2; exit 2; }

# Prints the usage.
usage() { sed -n '2,/^[^#]/ { /^#SBATCH/d; /^# shellcheck/d; s/^# \{0,1\}//p }' "$script"; }

# options SPECIFICATION ARGUMENTS...: reads the arguments of the script.
# The specification lists the options: 'time= first o=' stands for --time VALUE (or --time=VALUE), the flag
# --first, and -o VALUE. A value goes to the variable with the option's name, with _ in place of -; the
# variable of a flag becomes true. The array `arguments` gets all other arguments, including a -- and every
# argument after the --. With * in the specification, `arguments` also gets unknown options; without *, the
# script refuses an unknown option. It always refuses a missing value. -h and --help print the usage.
options() {
  local specification=" $1 " name
  shift
  arguments=()
  while (($#)); do
    name=${1%%=*} name=${name#-} name=${name#-}
    case $1 in
      -h | --help) usage; exit 0 ;;
      --) arguments+=("$@"); return ;;
      --*=*)
        if [[ $specification == *" $name= "* ]]; then
          printf -v "${name//-/_}" %s "${1#*=}"
        elif [[ $specification == *" $name "* ]]; then
          refuse "found '$1', expected --$name without a value"
        else
          keep_unknown "$1"
        fi ;;
      --* | -?)
        if [[ $specification == *" $name= "* ]]; then
          (($# > 1)) || refuse "found $1 without a value"
          printf -v "${name//-/_}" %s "$2"
          shift
        elif [[ $specification == *" $name "* ]]; then
          printf -v "${name//-/_}" true
        else
          keep_unknown "$1"
        fi ;;
      -?*) keep_unknown "$1" ;;
      *) arguments+=("$1") ;;
    esac
    shift
  done
}

# Handles an option that is not in the specification of `options`.
keep_unknown() {
  local known
  if [[ $specification == *" * "* ]]; then arguments+=("$1"); return; fi
  read -ra known <<<"${specification//=/}"
  refuse "unknown option '$1', expected $(printf -- '--%s, ' "${known[@]}" help | sed -E 's/--(.,)/-\1/g; s/, $//; s/(.*), /\1 or /')"
}

# seconds_of TIME: puts the number of seconds in a time such as 90s, 10m or 8h into the variable `seconds`.
seconds_of() {
  [[ $1 =~ ^([1-9][0-9]{0,8})([smh])$ ]] || refuse "found the time '$1', expected such as 90s, 10m or 8h"
  local -A unit=([s]=1 [m]=60 [h]=3600)
  seconds=$((BASH_REMATCH[1] * unit[${BASH_REMATCH[2]}]))
}
