

def at_arrays(call, numbers):
    """Calls a function with arrays of other shapes, which broadcast to one of two rows and three columns."""
    shapes = [(2, 1), (3,), (2, 3)]
    arrays = [np.full(shapes[k % 3], number, KIND) for k, number in enumerate(numbers)]
    found = call(*arrays)
    if not arrays:
        return found
    assert found.dtype == KIND
    found = np.reshape(found, (-1, np.broadcast(*arrays).size))
    assert np.all(found == found[:, :1])
    return found[:, 0].tolist()


