# find_package(mms_capi) makes two targets: mms_capi::mms_capi, the shared library, and
# mms_capi::static.
get_filename_component(_mms_capi_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

if(NOT TARGET mms_capi::mms_capi)
  add_library(mms_capi::mms_capi SHARED IMPORTED)
  set_target_properties(mms_capi::mms_capi PROPERTIES
    IMPORTED_LOCATION "${_mms_capi_prefix}/lib/${CMAKE_SHARED_LIBRARY_PREFIX}mms_capi${CMAKE_SHARED_LIBRARY_SUFFIX}"
    INTERFACE_INCLUDE_DIRECTORIES "${_mms_capi_prefix}/include")

  find_package(Threads QUIET REQUIRED)
  add_library(mms_capi::static STATIC IMPORTED)
  set_target_properties(mms_capi::static PROPERTIES
    IMPORTED_LOCATION "${_mms_capi_prefix}/lib/${CMAKE_STATIC_LIBRARY_PREFIX}mms_capi${CMAKE_STATIC_LIBRARY_SUFFIX}"
    INTERFACE_INCLUDE_DIRECTORIES "${_mms_capi_prefix}/include"
    INTERFACE_LINK_LIBRARIES "Threads::Threads;${CMAKE_DL_LIBS};m")
endif()

unset(_mms_capi_prefix)
