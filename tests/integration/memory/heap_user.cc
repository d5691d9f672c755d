// SPDX-License-Identifier: BSD-3-Clause
// What core must not do, so that the check of its symbols can be seen to fail.
int* NewNumber() { return new int; }
