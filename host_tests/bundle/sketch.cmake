# Makes `source` of the example for Arduino as a sketch becomes one: in a folder of its own, after the header of the core.
set(library ${BUNDLE}/taut)
file(COPY ${library}/examples/JackLoad DESTINATION ${WORK})
file(READ ${WORK}/JackLoad/JackLoad.ino sketch)
set(source ${WORK}/JackLoad/JackLoad.ino.cpp)
file(WRITE ${source} "#include <Arduino.h>\n#line 1 \"JackLoad.ino\"\n${sketch}")
set(include -I${here}/stubs -I${library}/src)
