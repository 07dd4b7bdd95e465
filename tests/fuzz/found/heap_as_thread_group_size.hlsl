// SPDX-License-Identifier: MIT
[numthreads(ResourceDescriptorHeap,ResourceDescriptorHeap,ResourceDescriptorHeap)]void main(){
