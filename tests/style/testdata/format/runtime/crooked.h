// SPDX-License-Identifier: MIT
#pragma once

int  crooked( int x );
