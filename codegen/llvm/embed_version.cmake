# cmake -DOUT=file -DFILES=file,... -P embed_version.cmake: a hash of the sources that make code, for cached code.
string(REPLACE "," ";" files "${FILES}")
set(all "")
foreach(file IN LISTS files)
  file(SHA256 "${file}" one)
  string(APPEND all "${one}")
endforeach()
string(SHA256 hash "${all}")
file(WRITE "${OUT}" "// Made from the sources that make code.\n#include \"codegen/llvm/code_version.h\"\n\nnamespace rung::codegen {\n\nstd::string_view codeVersion() { return \"${hash}\"; }\n\n} // namespace rung::codegen\n")
