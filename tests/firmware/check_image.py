#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Says what a firmware image is made of and how deep its stack can get; fails if that is not allowed.

Symbols: neither a heap, nor exceptions, nor double precision outside of the start-up. Bytes: per section and per
structure. Stack: the deepest path of the compiler's call graph (-fcallgraph-info=su); functions of the run-time
libraries, which have none, are read off the disassembly.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys

import emulated

FORBIDDEN = re.compile(
    r'^(malloc|calloc|realloc|free|_malloc_r|_free_r|_realloc_r|_calloc_r|_sbrk|_sbrk_r|sbrk|'
    r'_Zn[wa]\w*|_Zd[la]\w*|__cxa_\w+|_Unwind_\w+|__gxx_\w+|\w*printf\w*|abort|exit|atexit|__aeabi_atexit)$')
# Double precision in software: arithmetic, comparisons and conversions.
DOUBLE = re.compile(r'^__aeabi_(d\w+|cd\w+|f2d|i2d|ui2d|l2d|ul2d)$')
# Checks the settings once, when the tracker is made.
MAY_USE_DOUBLE = re.compile(r'^((void|auto) )?disflow::(Validate\(|.*VisitFields<.*Validate\()')

# What calls through pointers can reach, by caller; the first match counts. Vtables and the clock lent to the tracker.
INDIRECT = [
    (r'disflow::firmware::Firmware::', r'disflow::hal::depth_stream::StreamSensor::Do|disflow::baremetal::CmsdkUart::Do'
     r'|disflow::baremetal::TickClock<.*>::Do'),
    (r'disflow::firmware::\(anonymous namespace\)::Now', r'disflow::baremetal::TickClock<.*>::DoNowNs'),
    (r'disflow::hal::depth_stream::StreamSensor::', r'disflow::baremetal::(CmsdkUart|RecordedLine|TickClock<.*>)::Do'),
    (r'disflow::baremetal::RecordedLine::', r'disflow::baremetal::CmsdkUart::Do'),
    (r'disflow::baremetal::FrameWatchdog::|DisflowSysTick|disflow::baremetal::TickClock',
     r'disflow::baremetal::TickClock<.*>::DoNowNs'),
    (r'disflow::(Tracker|StageStopwatch)', r'disflow::firmware::\(anonymous namespace\)::Now'),
    (r'DisflowReset', r'_GLOBAL__sub_I_'),
]
# Pushed by the processor when an interrupt comes: 26 registers with the FPU's, and four bytes to align them.
EXCEPTION_FRAME = 26 * 4 + 4
INTERRUPTS = re.compile(r'OnUartReceive|OnUartTransmit|DisflowSysTick|baremetal::Register')


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def demangled(names):
    names = list(names)
    out = subprocess.run(['arm-none-eabi-c++filt'], input='\n'.join(names), check=True, capture_output=True, text=True)
    return dict(zip(names, out.stdout.splitlines()))


class Function:
    def __init__(self, name):
        self.name = name
        self.calls = set()
        self.indirect = False
        self.bytes = 0


def read_disassembly(image):
    """Every function of the image with the functions it calls; frame sizes as far as prologues show them."""
    functions = {}
    current = None
    for line in run('arm-none-eabi-objdump', '-d', '--no-show-raw-insn', image).splitlines():
        head = re.match(r'^[0-9a-f]+ <(.+)>:$', line)
        if head:
            current = functions.setdefault(head.group(1), Function(head.group(1)))
            continue
        code = re.match(r'^\s*[0-9a-f]+:\s+(\S+)\s*(.*)$', line)
        if not current or not code:
            continue
        op, operands = code.groups()
        target = re.search(r'<([^>+]+)>', operands)
        if re.match(r'^(bl|b(\w\w)?(\.[nw])?|cbn?z)$', op) and target:
            if target.group(1) != current.name:
                current.calls.add(target.group(1))
        elif op == 'blx' or (op == 'bx' and operands != 'lr'):
            current.indirect = True
        elif op in ('push', 'push.w', 'stmdb') and ('sp!' in operands or op.startswith('push')):
            current.bytes += 4 * count_registers(operands)
        elif op == 'vpush':
            current.bytes += 4 * count_registers(operands)
        elif op.startswith('sub') and operands.startswith('sp'):
            number = re.search(r'#(\d+)', operands)
            current.bytes += int(number.group(1)) if number else 0
        elif op.startswith('str') and 'sp, #-' in operands and operands.endswith(']!'):
            current.bytes += int(re.search(r'#-(\d+)', operands).group(1))
    return functions


def count_registers(operands):
    total = 0
    inside = re.search(r'\{(.*)\}', operands).group(1)
    for part in inside.split(','):
        ends = re.findall(r'[rsd](\d+)', part)
        width = 2 if 'd' in part and part.strip().startswith('d') else 1
        total += width * (int(ends[-1]) - int(ends[0]) + 1 if len(ends) == 2 else 1)
    return total


def read_call_graph(build):
    """Frame sizes that the compiler states, by assembler name."""
    sizes = {}
    for file in pathlib.Path(build).rglob('*.ci'):
        for node in re.finditer(r'node: \{ title: "([^"]+)" label: "([^"]+)"', file.read_text()):
            stated = re.search(r'(\d+) bytes \((\w+)', node.group(2))
            if stated:
                if stated.group(2) not in ('static', 'dynamic,bounded'):
                    sys.exit(f'{file}: {node.group(2)}: its frame has no bound')
                name = node.group(1).split(':')[-1]
                sizes[name] = max(sizes.get(name, 0), int(stated.group(1)))
    return sizes


def deepest(functions, plain, root):
    """Bytes and path of the deepest stack under root."""
    memo = {}
    names = {f: plain[f] for f in functions}

    def targets(function):
        calls = set(function.calls)
        if function.indirect:
            for caller, called in INDIRECT:
                if re.search(caller, names[function.name]):
                    calls |= {f for f in functions if re.search(called, names[f])}
                    break
            else:
                if function.name not in ('main',):
                    sys.exit(f'{names[function.name]}: calls through a pointer that INDIRECT does not know')
        return calls

    def visit(name, path):
        if name in path:
            sys.exit('recursion: ' + ' -> '.join(names.get(n, n) for n in path + [name]))
        if name in memo:
            return memo[name]
        function = functions.get(name)
        if function is None:
            return 0, [name]
        best = (0, [])
        for called in targets(function):
            best = max(best, visit(called, path + [name]), key=lambda found: found[0])
        memo[name] = (function.bytes + best[0], [name] + best[1])
        return memo[name]

    return visit(root, [])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('image')
    parser.add_argument('--build', required=True, help='folder with the .ci files')
    parser.add_argument('--json', help='write the figures there')
    arguments = parser.parse_args()
    emulated.skip_unless_built()

    symbols = {}
    for line in run('arm-none-eabi-nm', '-S', arguments.image).splitlines():
        parts = line.split()
        if len(parts) == 4:
            symbols[parts[3]] = (int(parts[1], 16), parts[2])
        else:
            symbols[parts[-1]] = (0, parts[-2])
    if len(symbols) < 100:
        sys.exit(f'{arguments.image}: nm lists next to nothing; the check would be void')
    faults = [f'{name} is in the image' for name in symbols if FORBIDDEN.match(name)]

    functions = read_disassembly(arguments.image)
    plain = demangled(functions)
    for function in functions.values():
        for called in function.calls:
            if DOUBLE.match(called) and not DOUBLE.match(function.name) \
                    and not MAY_USE_DOUBLE.match(plain[function.name]):
                faults.append(f'{plain[function.name]} computes in double precision ({called})')

    sizes = read_call_graph(arguments.build)
    known = 0
    for function in functions.values():
        if function.name in sizes:
            function.bytes = sizes[function.name]
            known += 1
    if known < 50:
        sys.exit(f'{arguments.build}: the call graph of {known} functions only; the check would be void')
    main_stack, path = deepest(functions, plain, 'DisflowReset')
    interrupt = max((deepest(functions, plain, name) for name in functions if INTERRUPTS.search(plain[name])),
                    key=lambda found: found[0])
    stack = main_stack + EXCEPTION_FRAME + interrupt[0]

    sections = {}
    for line in run('arm-none-eabi-size', '-A', '-d', arguments.image).splitlines():
        parts = line.split()
        if len(parts) == 3 and parts[0] in ('.text', '.ARM.exidx', '.data', '.bss'):
            sections[parts[0]] = int(parts[1])
    stack_size = symbols_value(arguments.image, 'disflow_stack_size')
    flash = sections['.text'] + sections.get('.ARM.exidx', 0) + sections['.data']
    ram = sections['.data'] + sections['.bss'] + stack_size
    if stack > stack_size:
        faults.append(f'the stack may need {stack} bytes, {stack_size} are there')

    print(f'{arguments.image}')
    print(f'  flash {flash} bytes, RAM {ram} bytes (of these {stack_size} for the stack)')
    for name, size in sections.items():
        print(f'    {name:12} {size:8}')
    objects = sorted(((size, name) for name, (size, kind) in symbols.items() if kind in 'bBdD' and size >= 1000),
                     reverse=True)
    names = demangled(name for _, name in objects)
    for size, name in objects:
        print(f'    {size:8}  {names[name]}')
    print(f'  stack {stack} bytes at most: {main_stack} for the program, {EXCEPTION_FRAME} + {interrupt[0]} for an interrupt')
    for name in path:
        if name in functions:
            print(f'    {functions[name].bytes:6}  {plain[name][:110]}')
    if arguments.json:
        figures = {'flash_bytes': flash, 'ram_bytes': ram, 'stack_reserved_bytes': stack_size, 'stack_bound_bytes': stack,
                   'sections': sections, 'objects': {names[name]: size for size, name in objects},
                   'deepest_path': [plain.get(name, name) for name in path]}
        pathlib.Path(arguments.json).write_text(json.dumps(figures, indent=2))
    for fault in faults:
        print(f'{arguments.image}: {fault}', file=sys.stderr)
    return 1 if faults else 0


def symbols_value(image, name):
    for line in run('arm-none-eabi-nm', image).splitlines():
        if line.split()[-1] == name:
            return int(line.split()[0], 16)
    sys.exit(f'{image}: no symbol {name}')


if __name__ == '__main__':
    sys.exit(main())
