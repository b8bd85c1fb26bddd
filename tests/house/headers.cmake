# Target `headers` (not part of `all`): each header compiles alone, and twice in a row.
file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/geometry/*.hpp
  ${PROJECT_SOURCE_DIR}/dem/*.hpp ${PROJECT_SOURCE_DIR}/analysis/*.hpp ${PROJECT_SOURCE_DIR}/apps/*.hpp
  ${PROJECT_SOURCE_DIR}/tests/oracle/*.hpp
  ${PROJECT_SOURCE_DIR}/tests/support/*.hpp)
set(units)
foreach(header ${headers})
  string(REGEX REPLACE "/" "." name ${header})
  set(unit ${CMAKE_CURRENT_BINARY_DIR}/headers/${name}.cpp)
  file(GENERATE OUTPUT ${unit} CONTENT "#include \"${header}\"\n#include \"${header}\"  // guarded\n")
  list(APPEND units ${unit})
endforeach()
add_library(headers OBJECT EXCLUDE_FROM_ALL ${units})
target_link_libraries(headers PRIVATE isostat_flags Eigen3::Eigen nlohmann_json::nlohmann_json)
