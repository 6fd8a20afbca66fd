# A manual page, compressed: what the program's help says.
execute_process(COMMAND ${PROGRAM} ${HELP} OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "\\" "\\e" help "${help}")
string(REGEX REPLACE "(^|\n)([.'])" "\\1\\\\&\\2" help "${help}")
string(REPLACE "-" "\\-" help "${help}")
string(REGEX REPLACE "\n.*" "" first "${help}")
string(TOUPPER ${NAME} title)
string(REPLACE "-" "\\-" name "${NAME}")
string(REGEX REPLACE "\\.gz$" "" text ${OUTPUT})
file(WRITE ${text} ".TH ${title} 1 \"\" \"airybench ${VERSION}\"
.SH NAME
${name} \\- ${first}
.SH DESCRIPTION
.nf
${help}.fi
")
execute_process(COMMAND gzip -9nf ${text} COMMAND_ERROR_IS_FATAL ANY)
