// SPDX-License-Identifier: MIT
// CComPtr and _com_ptr_t: what they hold, and when they release it.
#include <atlbase.h>
#include <comdef.h>
#include <d3d12.h>
#include <objidlbase.h>
#include <windows.h>

#include <gtest/gtest.h>

#include <string_view>
#include <utility>

#include "d3d12/com/blob.h"

// Outside of clang's MS mode nothing else gives it an id.
__CRT_UUID_DECL(ID3D10Blob, 0x8BA5FB08, 0x5195, 0x40E2, 0xAC, 0x58, 0x0D, 0x98, 0x9C, 0x3A, 0x01,
                0x02)

namespace kaamos::d3d12 {
namespace {

ULONG references(IUnknown* object) {
  object->AddRef();
  return object->Release();
}

_COM_SMARTPTR_TYPEDEF(ID3DBlob, __uuidof(ID3DBlob));
_COM_SMARTPTR_TYPEDEF(IMalloc, __uuidof(IMalloc));

// A blob, of which the test holds one reference.
class Pointers : public testing::Test {
 protected:
  ~Pointers() override {
    EXPECT_EQ(references(blob_), 1u);
    blob_->Release();
  }

  ID3DBlob* blob_ = new Blob(std::string_view("held"));
};

TEST_F(Pointers, CComPtrHoldsOneReference) {
  CComPtr<ID3DBlob> a(blob_);
  CComPtr<ID3DBlob> b = a;
  EXPECT_EQ(references(blob_), 3u);
  CComPtr<ID3DBlob> c = std::move(b);
  EXPECT_TRUE(!b);
  EXPECT_EQ(references(blob_), 3u);
  a = nullptr;
  EXPECT_EQ(references(blob_), 2u);
  EXPECT_EQ(c->GetBufferSize(), 5u);
  ID3DBlob* taken = c.Detach();
  EXPECT_EQ(references(blob_), 2u);
  a.Attach(taken);
  EXPECT_TRUE(a.IsEqualObject(blob_));
  ASSERT_EQ(a.CopyTo(&c), S_OK);
  EXPECT_EQ(references(blob_), 3u);
  c.Release();
  EXPECT_TRUE(!c);
}

TEST_F(Pointers, CComPtrAsksForOtherInterfaces) {
  CComPtr<IUnknown> unknown;
  ASSERT_EQ(CComPtr<ID3DBlob>(blob_).QueryInterface(&unknown), S_OK);
  const CComQIPtr<ID3DBlob> same(unknown);
  EXPECT_EQ(same.p, blob_);
  CComPtr<IMalloc> other;
  other = unknown;
  EXPECT_TRUE(!other);
  EXPECT_EQ(references(blob_), 3u);
}

TEST_F(Pointers, ComPtrTHoldsOneReference) {
  ID3DBlobPtr a(blob_);
  ID3DBlobPtr b = a;
  EXPECT_EQ(references(blob_), 3u);
  ID3DBlobPtr c(std::move(b));
  EXPECT_EQ(references(blob_), 3u);
  a = c;
  a = nullptr;
  EXPECT_EQ(references(blob_), 2u);
  ASSERT_EQ(c.QueryInterface(__uuidof(ID3DBlob), &a), S_OK);
  EXPECT_EQ(a.GetInterfacePtr(), blob_);
  EXPECT_EQ(a->GetBufferSize(), 5u);
  c.Release();
  EXPECT_TRUE(c == nullptr);
  b.Attach(a.Detach());
  EXPECT_EQ(references(blob_), 2u);
}

TEST_F(Pointers, AComPtrTOfAnotherInterfaceIsNullAndThrowsWhenItIsUsed) {
  const ID3DBlobPtr blob(blob_);
  const IMallocPtr memory = blob;
  EXPECT_EQ(memory.GetInterfacePtr(), nullptr);
  try {
    memory->HeapMinimize();
    FAIL() << "null was used";
  } catch (const _com_error& error) {
    EXPECT_EQ(error.Error(), E_POINTER);
  }
}

// `return false;` of functions that return a pointer.
ID3DBlobPtr none() {
  return false;
}

TEST(NullPointers, ComPtrTIsMadeOfFalse) {
  EXPECT_EQ(none().GetInterfacePtr(), nullptr);
  EXPECT_THROW(ID3DBlobPtr(1), _com_error);
}

}  // namespace
}  // namespace kaamos::d3d12
