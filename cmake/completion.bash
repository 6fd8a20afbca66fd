# Completes commands and options, as the program's own --help lists them, and files.
_airybench() {
  local word=${COMP_WORDS[COMP_CWORD]} words=("${COMP_WORDS[0]}")
  [[ ${COMP_CWORD} -gt 1 && ${COMP_WORDS[1]} != -* ]] && words+=("${COMP_WORDS[1]}")
  if [[ $word == -* ]]; then
    local options
    options=$({ "${words[@]}" --help-all || "${words[@]}" --help; } 2>/dev/null | grep -o '^ *\(-[a-z],\)\?--[a-z-]*' | grep -o -- '--[a-z-]*')
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
  elif [[ ${COMP_CWORD} -eq 1 && ${COMP_WORDS[0]##*/} == airybench ]]; then
    local commands
    commands=$("${words[@]}" --help 2>/dev/null | sed -n '/^Commands$/,/^$/s/^  \([a-z-]*\) .*/\1/p')
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}
complete -o nospace -F _airybench airybench airybench-meshgen
