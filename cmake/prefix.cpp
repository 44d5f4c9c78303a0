// SPDX-License-Identifier: Apache-2.0
// Only here so that something compiles the headers that sources share (CrowdfaceModule.cmake, tests/CMakeLists.txt).
