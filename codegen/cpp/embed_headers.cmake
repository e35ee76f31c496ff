# cmake -DOUT=file -DDIR=rtlib/abi -P embed_headers.cmake: the ABI headers as a C++ table of raw strings.
set(text "// Made from the headers of rtlib/abi.\n#include \"codegen/cpp/embedded_headers.h\"\n\nnamespace rung::codegen {\nnamespace {\nconstexpr EmbeddedHeader kHeaders[] = {\n")
foreach(name rung/program.h rung/sem.hpp rung/real.hpp rung/gen.hpp)
  file(READ "${DIR}/${name}" content)
  string(APPEND text "    {\"${name}\", R\"rungheader(${content})rungheader\"},\n")
endforeach()
string(APPEND text "};\n} // namespace\n\nstd::span<const EmbeddedHeader> embeddedHeaders() { return kHeaders; }\n\n} // namespace rung::codegen\n")
file(WRITE "${OUT}" "${text}")
