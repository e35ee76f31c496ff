"""The folders at the top of the repository, by what is in them."""

# The product: C and C++ from which libraries and programs are built.
PRODUCT = ("codegen", "compiler", "frontend", "ir", "machine", "rtlib", "sim", "tools")
ALL = (*PRODUCT, "debian", "docs", "examples", "packaging", "tests")
