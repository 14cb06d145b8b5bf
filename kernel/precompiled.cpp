// The headers of libraries that CMakeLists.txt names for all targets.
