# cmake -DFOLDER=… -DOUT=… -DFILES="a;b" -P embed.cmake: the files as a table of TemplateFile, text by text.
set(table "")
foreach(file IN LISTS FILES)
  file(READ "${FOLDER}/${file}" text)
  string(APPEND table "{\"${file}\",\nR\"~~~(${text})~~~\"},\n")
endforeach()
file(WRITE "${OUT}" "${table}")
