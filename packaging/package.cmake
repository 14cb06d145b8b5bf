# The package of Python with the programs that it starts, as setup.py puts it into a wheel: the target kerf_package, and
# the component `package` of cmake --install, which has nothing of the rest.
set(KERF_PYTHON_ABI ${Python3_SOABI} CACHE INTERNAL "That of the module, for setup.py")
set(package_programs kerf_without_mpi)
foreach(program kerf-worker kerf-cad kerf-3mf kerf-solve kerf-view)
  if(TARGET ${program})
    list(APPEND package_programs ${program})
  endif()
endforeach()
set(package_modules kerf_python)
if(TARGET kerf_python_mpi)
  list(APPEND package_modules kerf_python_mpi)
endif()
add_custom_target(kerf_package DEPENDS ${package_modules} ${package_programs})
install(TARGETS ${package_modules} LIBRARY DESTINATION . COMPONENT package EXCLUDE_FROM_ALL)
install(TARGETS ${package_programs} RUNTIME DESTINATION bin COMPONENT package EXCLUDE_FROM_ALL)
if(TARGET kerf-view)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/shaders DESTINATION bin COMPONENT package EXCLUDE_FROM_ALL)
endif()

# The same package for who installs the whole tree; its programs are those of bin.
cmake_path(GET Python3_SITEARCH FILENAME packages_name)  # dist-packages or site-packages
set(KERF_PYTHON_FOLDER lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/${packages_name} CACHE STRING
  "Where the package of Python is installed, below the prefix")
install(TARGETS ${package_modules} LIBRARY DESTINATION ${KERF_PYTHON_FOLDER}/kerf)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/python/kerf DESTINATION ${KERF_PYTHON_FOLDER} FILES_MATCHING PATTERN *.py
  PATTERN *.pyi PATTERN py.typed PATTERN __pycache__ EXCLUDE PATTERN bin EXCLUDE)
