# Targets Frangible::Frangible, the shared library, and Frangible::Static.
get_filename_component(_frangible "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
if(NOT TARGET Frangible::Frangible)
  add_library(Frangible::Frangible SHARED IMPORTED)
  set_target_properties(Frangible::Frangible PROPERTIES
    IMPORTED_LOCATION "${_frangible}/lib/@shared@"
    INTERFACE_INCLUDE_DIRECTORIES "${_frangible}/include")
  add_library(Frangible::Static STATIC IMPORTED)
  set_target_properties(Frangible::Static PROPERTIES
    IMPORTED_LOCATION "${_frangible}/lib/@static@"
    INTERFACE_INCLUDE_DIRECTORIES "${_frangible}/include"
    INTERFACE_LINK_LIBRARIES "@private@")
  if(WIN32)
    set_target_properties(Frangible::Frangible PROPERTIES IMPORTED_IMPLIB "${_frangible}/lib/@shared@.lib")
  endif()
endif()
unset(_frangible)
