# The changelog that Debian asks of a package, compressed: it names the version and refers to ours.
#   cmake -D VERSION=... -D CITATION=CITATION.cff -D MAINTAINER=... -D OUTPUT=...changelog.gz -P
file(STRINGS ${CITATION} released REGEX "^date-released: ")
string(REPLACE "date-released: " "" released "${released}")
execute_process(COMMAND date -R -u -d "${released}" OUTPUT_VARIABLE date COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "\\.gz$" "" text ${OUTPUT})
file(WRITE ${text} "airybench (${VERSION}) stable; urgency=medium

  * CHANGELOG.md lists the changes.

 -- ${MAINTAINER}  ${date}")
execute_process(COMMAND gzip -9nf ${text} COMMAND_ERROR_IS_FATAL ANY)
