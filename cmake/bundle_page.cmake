# Makes PAGE from SOURCE with npm, in BUILD; an empty PAGE where that cannot be done. Run as a script:
# cmake -DSOURCE=... -DBUILD=... -DPAGE=... [-DNPM=... -DNODE=...] -P bundle_page.cmake
file(MAKE_DIRECTORY ${BUILD})

function(no_page why)
  message(WARNING "no report page is built in: ${why}")
  file(WRITE ${PAGE} "")
endfunction()

if(NOT NPM)
  file(WRITE ${PAGE} "") # said when the build was configured
  return()
endif()

# Packages are fetched once for each lock file.
file(SHA256 ${SOURCE}/package-lock.json lock)
set(stamp ${BUILD}/node_modules/.fissura-${lock})
configure_file(${SOURCE}/package.json ${BUILD}/package.json COPYONLY)
configure_file(${SOURCE}/package-lock.json ${BUILD}/package-lock.json COPYONLY)
configure_file(${SOURCE}/build.mjs ${BUILD}/build.mjs COPYONLY)
if(NOT EXISTS ${stamp})
  execute_process(COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error --fetch-retries=1
                          --fetch-retry-mintimeout=1000 --fetch-retry-maxtimeout=5000
                  WORKING_DIRECTORY ${BUILD} RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said
                  TIMEOUT 300)
  if(failed)
    string(REGEX MATCH "[^\n]*failed, reason:[^\n]*" why "${said}") # the rest is npm's own stack
    if(NOT why)
      string(SUBSTRING "${said}" 0 400 why)
    endif()
    no_page("`npm ci` failed. Is the registry within reach? All else is built; `make build` tries again.\n  ${why}")
    return()
  endif()
  file(TOUCH ${stamp})
endif()
execute_process(COMMAND ${NODE} build.mjs ${SOURCE}/src ${PAGE} WORKING_DIRECTORY ${BUILD}
                RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(failed)
  message(FATAL_ERROR "bundling the report page failed:\n${said}")
endif()
