# SPDX-FileCopyrightText: The stairwayd authors
# SPDX-License-Identifier: Apache-2.0
# Completion of @PROGRAM@ for bash.

# What may stand behind "PROGRAM [VERB] PREVIOUS-WORD"; nothing for file names.
_@PROGRAM@_words() {
  case $1 in
@ARMS@
  esac
}

_@PROGRAM@() {
  local at=$COMP_CWORD current=${COMP_WORDS[COMP_CWORD]} before= verb= words word
  # Bash takes = and : for words of their own, and replaces only what stands behind them.
  case $current in
    = | :) current= ;;
    *) ((--at)) ;;
  esac
  case ${COMP_WORDS[at]} in
    :) before=${COMP_WORDS[at - 1]}: && ((at -= 2)) ;;
    =) [[ ${COMP_WORDS[--at]} == -* ]] || return 0 ;;
  esac
  ((@HAS_VERBS@ && COMP_CWORD > 1)) && verb=" ${COMP_WORDS[1]}"
  words=$(_@PROGRAM@_words "@PROGRAM@$verb ${COMP_WORDS[at]}")
  COMPREPLY=()
  for word in $(compgen -W "$words" -- "$before$current"); do
    COMPREPLY+=("${word#"$before"}")
  done
  [[ ${COMP_WORDS[at]} != --set ]] || compopt -o nospace 2>/dev/null
}

complete -o default -F _@PROGRAM@ @PROGRAM@
