// Has no code of its own: with it, the headers that tests share are compiled (cmake/core_tests.cmake).
