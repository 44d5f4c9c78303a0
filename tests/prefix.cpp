// SPDX-License-Identifier: Apache-2.0
// Only here so that something compiles the headers that tests share (tests/CMakeLists.txt).
