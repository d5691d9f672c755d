// SPDX-License-Identifier: BSD-3-Clause
'use strict';
// The independent side: standard messages as the mavlink-mappings package defines them, the private
// one generated from docs/disflow.xml by mavlink-mappings-gen. Nothing here knows DisFlow's encoder.
const fs = require('fs');
const {minimal, common, MavLinkData, MavLinkPacketField, MSG_ID_MAGIC_NUMBER} =
    require('mavlink-mappings');
const {generateAll} = require('mavlink-mappings-gen');
const {MavLinkProtocolV2} = require('node-mavlink');

/** Makes a message class of a parsed XML definition, laid out by MAVLink's rule. */
function classFromDefinition(definition) {
  const bySize = (list) => [...list].sort((a, b) => b.fieldSize - a.fieldSize);
  const ordered = [...bySize(definition.fields.filter((field) => !field.extension)),
                   ...definition.fields.filter((field) => field.extension)];
  let offset = 0;
  const fields = ordered.map((field) => {
    const made = new MavLinkPacketField(field.source.name, field.name, offset, field.extension,
                                        field.fieldSize, field.fieldType, field.units,
                                        field.arrayLength || 0);
    offset += field.size;
    return made;
  });
  return class extends MavLinkData {
    static MSG_ID = Number(definition.id);
    static MSG_NAME = definition.source.name;
    static PAYLOAD_LENGTH = offset;
    static MAGIC_NUMBER = definition.magic;
    static FIELDS = fields;
  };
}

/** @returns {Promise<{classes, magicNumbers}>} message classes by MAVLink name, CRC_EXTRA by id. */
async function loadDialect(xmlPath) {
  const {messages} = await generateAll(fs.readFileSync(xmlPath, 'utf8'), {write() {}}, 'disflow');
  const classes = {HEARTBEAT: minimal.Heartbeat, ODOMETRY: common.Odometry,
                   COMMAND_LONG: common.CommandLong, COMMAND_ACK: common.CommandAck,
                   SYSTEM_TIME: common.SystemTime, TIMESYNC: common.TimeSync,
                   LANDING_TARGET: common.LandingTarget, FOLLOW_TARGET: common.FollowTarget,
                   GPS_GLOBAL_ORIGIN: common.GpsGlobalOrigin};
  const magicNumbers = {...MSG_ID_MAGIC_NUMBER};
  for (const definition of messages) {
    const made = classFromDefinition(definition);
    classes[made.MSG_NAME] = made;
    magicNumbers[made.MSG_ID] = made.MAGIC_NUMBER;
  }
  return {classes, magicNumbers};
}

const special = {NaN, Infinity};

/** A field of vectors.json as node-mavlink wants it. */
function toNative(value, type) {
  if (Array.isArray(value)) return value.map((item) => toNative(item, type));
  if (/^u?int64_t/.test(type)) return BigInt(value);
  return typeof value === 'string' ? special[value] : value;
}

/** @returns {Buffer} one MAVLink 2 frame; incompatibilityFlags as in the protocol. */
function encode(vector, dialect, incompatibilityFlags = 0) {
  const clazz = dialect.classes[vector.message];
  const message = new clazz();
  for (const field of clazz.FIELDS) {
    message[field.name] = toNative(vector.fields[field.source], field.type);
  }
  return new MavLinkProtocolV2(vector.system_id, vector.component_id, incompatibilityFlags)
      .serialize(message, vector.sequence);
}

module.exports = {loadDialect, toNative, encode};
