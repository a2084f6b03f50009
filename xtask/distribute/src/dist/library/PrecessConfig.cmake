# Imported targets Precess::precess (static) and Precess::shared.
get_filename_component(_precess_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

if(NOT TARGET Precess::precess)
    add_library(Precess::precess STATIC IMPORTED)
    set_target_properties(Precess::precess PROPERTIES
        IMPORTED_LOCATION "${_precess_prefix}/lib/libprecess.a"
        IMPORTED_LINK_INTERFACE_LANGUAGES "C"
        INTERFACE_INCLUDE_DIRECTORIES "${_precess_prefix}/include")
endif()

if(NOT TARGET Precess::shared)
    add_library(Precess::shared SHARED IMPORTED)
    set_target_properties(Precess::shared PROPERTIES
        IMPORTED_LOCATION "${_precess_prefix}/lib/@SONAME@"
        IMPORTED_SONAME "@SONAME@"
        INTERFACE_INCLUDE_DIRECTORIES "${_precess_prefix}/include")
endif()

unset(_precess_prefix)
