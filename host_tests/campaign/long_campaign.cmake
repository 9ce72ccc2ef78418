# Runs both campaigns to the end, and fails if either does.
# cmake -D CAMPAIGN=program -D MANY_CABLES=program -P long_campaign.cmake
cmake_minimum_required(VERSION 3.22)
execute_process(COMMAND ${CAMPAIGN} --count 1000000 --threads 2 RESULT_VARIABLE usual)
execute_process(COMMAND ${MANY_CABLES} --count 300 --threads 2 --judge 4 RESULT_VARIABLE many)
if(NOT usual EQUAL 0 OR NOT many EQUAL 0)
  message(FATAL_ERROR "campaign ended with ${usual}, many_cables with ${many}")
endif()
