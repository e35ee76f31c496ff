# cmake -DOUT=file -DHEADER=file -DNAMESPACE=name -DFUNCTION=name -DFILES=file,... -P embed_version.cmake: a function that
# gives a hash of the files (rung_add_version in RungHelpers.cmake).
string(REPLACE "," ";" files "${FILES}")
set(all "")
foreach(file IN LISTS files)
  file(SHA256 "${file}" one)
  string(APPEND all "${one}")
endforeach()
string(SHA256 hash "${all}")
file(WRITE "${OUT}" "// Made from other sources.\n#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n\nstd::string_view ${FUNCTION}() { return \"${hash}\"; }\n\n} // namespace ${NAMESPACE}\n")
