# cmake -DIN=file -DOUT=file -P embed_bytes.cmake: the bitcode of sem_bitcode.cpp as a C++ array.
file(READ "${IN}" bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
string(REGEX REPLACE "(([^,]*,){24})" "\\1\n" bytes "${bytes}")
file(WRITE "${OUT}" "// Made from sem_bitcode.cpp.\n#include \"codegen/llvm/embedded.h\"\n\nnamespace rung::codegen {\nnamespace {\nalignas(4) constexpr unsigned char kBytes[] = {\n${bytes}};\n} // namespace\n\nstd::string_view semBitcode() { return {reinterpret_cast<const char*>(kBytes), sizeof kBytes}; }\n\n} // namespace rung::codegen\n")
