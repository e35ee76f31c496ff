// Compiled with nothing but the headers before it (RungHeaders.cmake).
