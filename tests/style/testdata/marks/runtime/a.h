// SPDX-License-Identifier: MIT
// TODO: write it
// A photoshop hackathon.
