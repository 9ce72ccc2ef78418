# Completion of taut in bash. What it offers is what `taut --help` lists.
_taut() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} offered=""
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    offered=$("${COMP_WORDS[0]}" --help 2>/dev/null | sed -n -e '/^[Ss][Uu][Bb][Cc]/,$s/^  \([a-z]\{1,\}\) .*/\1/p')
    mapfile -t COMPREPLY < <(compgen -W "$offered --help --version" -- "$word")
    return
  fi
  case $before in
    --scalar) offered="double float" ;;
    --method) offered="tracker stepwise" ;;
  esac
  if [ -n "$offered" ]; then
    mapfile -t COMPREPLY < <(compgen -W "$offered" -- "$word")
  elif [[ $word == -* ]]; then
    offered=$("${COMP_WORDS[0]}" "$command" --help 2>/dev/null | sed -n 's/^ *\(-h, *\)\{0,1\}\(-[a-z-]*\).*/\2/p')
    mapfile -t COMPREPLY < <(compgen -W "$offered" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}
complete -o filenames -F _taut taut
