# cmake -DOUT=file -DHEADER=file -DNAMESPACE=name -DFUNCTION=name -DFOLDER=folder -DFILES=file,... -P embed.cmake: a function
# that gives the files of the folder as texts (rung_embed in RungHelpers.cmake).
string(REPLACE "," ";" files "${FILES}")
set(text "// Made from the files of a folder.\n#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\nnamespace {\nconstexpr text::EmbeddedFile kFiles[] = {\n")
foreach(file IN LISTS files)
  file(READ "${FOLDER}/${file}" content)
  string(APPEND text "{\"${file}\",\nR\"~~~(${content})~~~\"},\n")
endforeach()
file(WRITE "${OUT}" "${text}};\n} // namespace\n\nstd::span<const text::EmbeddedFile> ${FUNCTION}() { return kFiles; }\n\n} // namespace ${NAMESPACE}\n")
